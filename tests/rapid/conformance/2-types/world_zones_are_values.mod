! rule: world zones are values, with an initial value, of any mode
! source: [backup] of RobotWare 5.61 to 6.16; [code] cells of running robots
MODULE Demo
    PERS wzstationary service := [1];
    VAR wztemporary zone;
    PROC main()
        limit service;
        WZFree zone;
    ENDPROC
    PROC limit(INOUT wzstationary wz)
        VAR shapedata volume;
        WZBoxDef \Inside, volume, [0, 0, 0], [1, 1, 1];
        WZLimSup \Stat, wz, volume;
    ENDPROC
ENDMODULE
