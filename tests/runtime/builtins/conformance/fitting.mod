MODULE fitting
    ! source: FLo-ABB/RAPID-Scripts-and-Demos [code]: arguments, errors, Rand up to 32767
    ! robot: irb120
    ! expect: [10,20,30] 5
    ! expect: 0 0
    ! expect: too few
    ! expect: too many
    ! expect: in line
    ! expect: in line
    ! expect: [12.5,-7.5,100] 0 0
    ! expect: TRUE
    ! expect: not turned
    ! expect: TRUE TRUE
    ! expect: 0 ERR_AXIS_PAR
    PERS tooldata pen := [TRUE,[[12.5,-7.5,100],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
    PERS tooldata found := [TRUE,[[0,0,0],[0,1,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
    CONST robtarget tip := [[300,0,300],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

    PROC main()
        VAR pos ball{5} := [[15,20,30],[10,25,30],[10,20,35],[5,20,30],[10,15,30]];
        VAR pos few{3} := [[15,20,30],[10,25,30],[10,20,35]];
        VAR pos many{101};
        VAR pos line{4} := [[1,1,1],[2,2,2],[3,3,3],[4,4,4]];
        VAR pos plane{4} := [[1,0,0],[0,1,0],[-1,0,0],[0,-1,0]];
        VAR pos centre;
        VAR num radius;
        VAR num rms;
        VAR num largest;
        VAR num mean;
        VAR num first;
        VAR bool different;
        FitSphere ball, centre, radius \RMS:=rms \MaxErr:=largest;
        TPWrite rounded(centre) + " " + NumToStr(radius, 0);
        TPWrite NumToStr(rms, 0) + " " + NumToStr(largest, 0);
        FitSphere few, centre, radius;
        FitSphere many, centre, radius;
        FitSphere line, centre, radius;
        FitSphere plane, centre, radius;
        MToolTCPCalib posture(0, 0), posture(25, 0), posture(0, 25), posture(-20, 15), found, largest, mean;
        TPWrite rounded(found.tframe.trans) + " " + NumToStr(largest, 0) + " " + NumToStr(mean, 0);
        TPWrite ValToStr(found.tframe.rot.q2 = 1);
        MToolTCPCalib posture(0, 0), posture(0, 0), posture(0, 0), posture(0, 0), found, largest, mean;
        first := Rand();
        FOR i FROM 1 TO 20 DO
            IF Rand() <> first different := TRUE;
        ENDFOR
        TPWrite ValToStr(different) + " " + ValToStr(first >= 0 AND first <= 32767 AND Trunc(first) = first);
        TPWrite ValToStr(GetMotorTorque(2)) + " " + torque(9);
    ERROR
        TEST ERRNO
        CASE ERR_FIT_TOO_FEW_POINTS:
            TPWrite "too few";
        CASE ERR_FIT_TOO_MANY_POINTS:
            TPWrite "too many";
        CASE ERR_FIT_POINTS_IN_LINE:
            TPWrite "in line";
        CASE ERR_ARGVALERR:
            TPWrite "not turned";
        ENDTEST
        TRYNEXT;
    ENDPROC

    FUNC string rounded(pos p)
        p := [Round(p.x \Dec:=1),Round(p.y \Dec:=1),Round(p.z \Dec:=1)];
        RETURN ValToStr(p);
    ENDFUNC

    FUNC jointtarget posture(num x, num y)
        RETURN CalcJointT(RelTool(tip, 0, 0, 0 \Rx:=x \Ry:=y), pen);
    ENDFUNC

    FUNC string torque(num axis)
        RETURN ValToStr(GetMotorTorque(axis));
    ERROR
        IF ERRNO = ERR_AXIS_PAR RETURN "ERR_AXIS_PAR";
    ENDFUNC
ENDMODULE
