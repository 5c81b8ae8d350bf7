! rule: arguments of WaitTestAndSet
! source: [manual] 3HAC050917
MODULE Demo
    PERS bool p_bool;
    PROC main()
        WaitTestAndSet p_bool;
        WaitTestAndSet;  ! -> RG311?
        WaitTestAndSet p_bool \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
