! rule: arguments of SiClose
! source: [manual] 3HAC050917
MODULE Demo
    PERS sensor p_sensor;
    PROC main()
        SiClose p_sensor;
        SiClose;  ! -> RG311?
        SiClose p_sensor \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
