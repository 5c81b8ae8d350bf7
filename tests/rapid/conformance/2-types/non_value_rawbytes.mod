! rule: rawbytes is a non-value type
! source: [manual] 3HAC050917
MODULE Demo
    VAR rawbytes a;
    VAR rawbytes b;
    PROC main()
        a := b;  ! -> RG309
    ENDPROC
ENDMODULE
