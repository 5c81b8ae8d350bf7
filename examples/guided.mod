MODULE guided
    ! Joints follow a partner in the network: device PC (UdpUc), options 689-1 or 3124-1.
    VAR egmident id;

    PROC main()
        MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v200, fine, tool0;
        EGMGetId id;
        EGMSetupUC ROB_1, id, "default", "PC" \Joint \CommTimeout:=1;
        ! The controller enforces these two limits, whatever the partner sends.
        EGMActJoint id \Tool:=tool0 \MaxPosDeviation:=30 \MaxSpeedDeviation:=40;
        EGMRunJoint id, EGM_STOP_HOLD \J1 \J2 \J3 \J4 \J5 \J6 \CondTime:=600;
        EGMReset id;
    ERROR
        ! ERR_UDPUC_COMM: the partner is silent. A new start of main begins anew.
        EGMReset id;
        RETURN;
    ENDPROC
ENDMODULE
