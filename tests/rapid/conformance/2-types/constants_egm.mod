! rule: named values: egm
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR num n;
    PROC main()
        n := EGM_STATE_DISCONNECTED;
        n := EGM_STATE_CONNECTED;
        n := EGM_STATE_RUNNING;
        n := EGM_STOP_HOLD;
        n := EGM_STOP_RAMP_DOWN;
        n := EGM_FRAME_BASE;
        n := EGM_FRAME_TOOL;
        n := EGM_FRAME_WOBJ;
        n := EGM_FRAME_WORLD;
        n := EGM_FRAME_JOINT;
        n := no_such_value;  ! -> RG302
    ENDPROC
ENDMODULE
