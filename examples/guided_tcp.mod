MODULE guided_tcp
    ! The TCP follows a partner in the network: device PC (UdpUc), options 689-1 or 3124-1.
    VAR egmident id;
    CONST pose base := [[0,0,0],[1,0,0,0]];

    PROC main()
        MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v200, fine, tool0;
        EGMGetId id;
        EGMSetupUC ROB_1, id, "default", "PC" \Pose \CommTimeout:=1;
        ! Poses are sent and reported in the base: wobj0 and both frames are the same one.
        EGMActPose id \Tool:=tool0 \WObj:=wobj0, base, EGM_FRAME_BASE, base, EGM_FRAME_BASE
            \MaxPosDeviation:=60 \MaxSpeedDeviation:=40;
        EGMRunPose id, EGM_STOP_HOLD \x \y \z \rx \ry \rz \CondTime:=600;
        EGMReset id;
    ERROR
        EGMReset id;
        RETURN;
    ENDPROC
ENDMODULE
