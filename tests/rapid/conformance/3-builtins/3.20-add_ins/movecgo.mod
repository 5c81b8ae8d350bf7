! rule: arguments of MoveCGO
! source: [manual] 3HAC050917
MODULE Demo
    VAR identno v_identno;
    VAR robtarget v_robtarget;
    VAR signalgo v_signalgo;
    VAR speeddata v_speeddata;
    VAR zonedata v_zonedata;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PROC main()
        MoveCGO v_robtarget, v_robtarget, v_speeddata, v_zonedata, p_tooldata, v_signalgo;
        MoveCGO v_robtarget, v_robtarget \ID:=v_identno, v_speeddata \T:=1, v_zonedata, p_tooldata \WObj:=p_wobjdata, v_signalgo;
        MoveCGO;  ! -> RG311?
        MoveCGO v_robtarget, v_robtarget, v_speeddata, v_zonedata, p_tooldata, v_signalgo \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
