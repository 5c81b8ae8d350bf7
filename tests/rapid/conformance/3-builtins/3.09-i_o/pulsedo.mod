! rule: arguments of PulseDO
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldo v_signaldo;
    PROC main()
        PulseDO v_signaldo;
        PulseDO \High \PLength:=1, v_signaldo;
        PulseDO;  ! -> RG311?
        PulseDO v_signaldo \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
