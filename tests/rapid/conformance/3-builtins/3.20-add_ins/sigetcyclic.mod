! rule: arguments of SiGetCyclic
! source: [manual] 3HAC050917
MODULE Demo
    PERS num p_num;
    PERS sensor p_sensor;
    PROC main()
        SiGetCyclic p_sensor, p_num, 1;
        SiGetCyclic;  ! -> RG311?
        SiGetCyclic p_sensor, p_num, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
