! rule: arguments of FricIdInit
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        FricIdInit;
        FricIdInit 1;  ! -> RG311?
    ENDPROC
ENDMODULE
