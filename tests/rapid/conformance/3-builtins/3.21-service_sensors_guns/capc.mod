! rule: arguments of CapC
! source: [manual] 3HAC050917
MODULE Demo
    PERS capdata p_capdata;
    PERS captrackdata p_captrackdata;
    PERS capweavedata p_capweavedata;
    PERS loaddata p_loaddata;
    PERS tooldata p_tooldata;
    PERS weavestartdata p_weavestartdata;
    PERS wobjdata p_wobjdata;
    VAR identno v_identno;
    VAR num v_num;
    VAR robtarget v_robtarget;
    VAR speeddata v_speeddata;
    VAR stoppointdata v_stoppointdata;
    VAR triggdata v_triggdata;
    VAR zonedata v_zonedata;
    PROC main()
        CapC v_robtarget, v_robtarget, v_speeddata, p_capdata, p_weavestartdata, p_capweavedata, v_zonedata, p_tooldata;
        CapC v_robtarget, v_robtarget \Id:=v_identno, v_speeddata, p_capdata \Movestart_timer:=v_num, p_weavestartdata, p_capweavedata, v_zonedata \Inpos:=v_stoppointdata, p_tooldata \WObj:=p_wobjdata \Track:=p_captrackdata \Time:=v_num \T1:=v_triggdata \T2:=v_triggdata \T3:=v_triggdata \T4:=v_triggdata \T5:=v_triggdata \T6:=v_triggdata \T7:=v_triggdata \T8:=v_triggdata \TLoad:=p_loaddata;
        CapC;  ! -> RG311?
    ENDPROC
ENDMODULE
