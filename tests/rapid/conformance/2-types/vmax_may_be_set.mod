! rule: vmax may be assigned
! source: [backup] programs of two cells with RobotWare 5.61
MODULE Demo
    CONST speeddata quick := vmax;
    PROC main()
        vmax := v2500;
        vmax.v_tcp := quick.v_tcp;
        v100.v_tcp := 3;  ! -> RG310
    ENDPROC
ENDMODULE
