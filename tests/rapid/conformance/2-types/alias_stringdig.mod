! rule: stringdig is string
! source: [manual] 3HAC050917
MODULE Demo
    VAR stringdig a;
    VAR string s;
    PROC main()
        a := s;
        s := a;
        a := 1;  ! -> RG307
    ENDPROC
ENDMODULE
