! rule: a PERS belongs to a module
! source: [K §2.18]
MODULE Demo
    PROC main()
        PERS num a := 1;  ! -> RG329
        a := 2;
        TPWrite "" \Num:=a;
    ENDPROC
ENDMODULE
