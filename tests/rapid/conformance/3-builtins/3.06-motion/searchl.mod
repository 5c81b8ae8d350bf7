! rule: arguments of SearchL
! source: [manual] 3HAC050917
MODULE Demo
    PERS bool p_bool;
    VAR robtarget v_robtarget;
    PERS tooldata p_tooldata;
    VAR signaldi v_signaldi;
    PERS wobjdata p_wobjdata;
    PERS loaddata p_loaddata;
    PROC main()
        SearchL v_signaldi, v_robtarget, v_robtarget, v100, p_tooldata;
        SearchL \Stop, v_signaldi \Flanks, v_robtarget, v_robtarget \ID:=1, v100 \V:=1, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        SearchL \PStop, p_bool \PosFlank, v_robtarget, v_robtarget \ID:=1, v100 \T:=1, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        SearchL \SStop, v_signaldi \NegFlank, v_robtarget, v_robtarget \ID:=1, v100 \V:=1, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        SearchL \Sup, p_bool \HighLevel, v_robtarget, v_robtarget \ID:=1, v100 \T:=1, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        SearchL \Stop, v_signaldi \LowLevel, v_robtarget, v_robtarget \ID:=1, v100 \V:=1, p_tooldata \WObj:=p_wobjdata \Corr \TLoad:=p_loaddata;
        SearchL v_signaldi, v_robtarget, v_robtarget, v100;  ! -> RG311
        SearchL v_signaldi, v_robtarget, v_robtarget, v100, p_tooldata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
