! rule: arguments of SiSetCyclic
! source: [manual] 3HAC050917
MODULE Demo
    PERS num p_num;
    PERS sensor p_sensor;
    PROC main()
        SiSetCyclic p_sensor, p_num, 1;
        SiSetCyclic;  ! -> RG311?
        SiSetCyclic p_sensor, p_num, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
