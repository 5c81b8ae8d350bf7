! rule: arguments of ISleep
! source: [manual] 3HAC050917
MODULE Demo
    VAR intnum v_intnum;
    PROC main()
        ISleep v_intnum;
        ISleep;  ! -> RG311?
        ISleep v_intnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
