! rule: arguments of MoveLAO
! source: [manual] 3HAC050917
MODULE Demo
    VAR identno v_identno;
    VAR robtarget v_robtarget;
    VAR signalao v_signalao;
    VAR speeddata v_speeddata;
    VAR zonedata v_zonedata;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PROC main()
        MoveLAO v_robtarget, v_speeddata, v_zonedata, p_tooldata, v_signalao, 1;
        MoveLAO v_robtarget \ID:=v_identno, v_speeddata \T:=1, v_zonedata, p_tooldata \WObj:=p_wobjdata, v_signalao, 1;
        MoveLAO;  ! -> RG311?
        MoveLAO v_robtarget, v_speeddata, v_zonedata, p_tooldata, v_signalao, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
