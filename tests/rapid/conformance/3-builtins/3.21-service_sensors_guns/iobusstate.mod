! rule: arguments of IOBusState
! source: [manual] 3HAC050917
MODULE Demo
    VAR busstate v_busstate;
    VAR string v_string;
    PROC main()
        IOBusState v_string, v_busstate;
        IOBusState v_string, v_busstate \Phys;
        IOBusState;  ! -> RG311?
    ENDPROC
ENDMODULE
