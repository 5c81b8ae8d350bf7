! rule: arguments of SiConnect
! source: [manual] 3HAC050917
MODULE Demo
    PERS sensor p_sensor;
    PROC main()
        SiConnect p_sensor;
        SiConnect p_sensor \NoStop;
        SiConnect;  ! -> RG311?
        SiConnect p_sensor \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
