! rule: a label and a datum of one routine differ
! source: [K §4.3]
MODULE Demo
    PROC main()
        VAR num a;
        a:  ! -> RG305
        a := 1;
        TPWrite "" \Num:=a;
    ENDPROC
ENDMODULE
