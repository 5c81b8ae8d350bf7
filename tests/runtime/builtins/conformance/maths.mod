!=== fitting
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
!=== maths
MODULE maths
    ! source: [manual] S4 Sin to ATan2 (degrees), Pow, Sqrt, Round, Trunc; half away from zero [mem]
    ! expect: 0.5 60 135
    ! expect: 1024 1.41421
    ! expect: 1 -1 0.38
    ! expect: 3
    ! expect: ERR_ARGVALERR
    ! expect: ERR_ARGVALERR
    ! expect: 1.4142135623731
    ! expect: not whole
    PERS num counter := 1;

    PROC main()
        TPWrite ValToStr(Sin(30)) + " " + ValToStr(ACos(0.5)) + " " + ValToStr(ATan2(1, -1));
        TPWrite ValToStr(Pow(2, 10)) + " " + ValToStr(Sqrt(2));
        TPWrite ValToStr(Round(0.5)) + " " + ValToStr(Trunc(-1.9)) + " " + ValToStr(Round(0.375 \Dec:=2));
        Incr counter;
        Add counter, 2;
        Decr counter;
        TPWrite ValToStr(counter);
        TPWrite ValToStr(Sqrt(-1));
        TPWrite ValToStr(Pow(0, 0));
        TPWrite ValToStr(SqrtDnum(2));
        TryInt 1.5;
    ERROR
        IF ERRNO = ERR_ARGVALERR TPWrite "ERR_ARGVALERR";
        IF ERRNO = ERR_INT_NOTVAL TPWrite "not whole";
        TRYNEXT;
    ENDPROC
ENDMODULE
!=== matrices
MODULE matrices
    ! source: [manual 3HAC050917] MatrixSolve, MatrixSolveQR, MatrixSVD; FitCircle: a circle through points
    ! expect: [1,-2,3]
    ! expect: [2,1] over
    ! expect: TRUE TRUE
    ! expect: TRUE TRUE
    ! expect: depend
    ! expect: too small
    ! expect: [1,2,3] 5 [0,0,1] 0.000
    ! expect: in line
    ! expect: too few
    VAR num way := 0;
    PROC main()
        VAR dnum a{3,3} := [[2,0,0],[1,1,0],[0,1,2]];
        VAR dnum b{3} := [2,-1,4];
        VAR dnum x{3};
        VAR dnum tall{3,2} := [[1,0],[0,1],[1,1]];
        VAR dnum c{3} := [2,1,3];
        VAR dnum y{2};
        VAR dnum q{3,3};
        VAR dnum r{3,2};
        VAR dnum u{3,2};
        VAR dnum s{2};
        VAR dnum v{2,2};
        VAR dnum same{2,2} := [[1,1],[1,1]];
        VAR pos points{5} := [[6,2,3],[1,7,3],[-4,2,3],[1,-3,3],[0,0,0]];
        VAR pos centre;
        VAR pos normal;
        VAR num radius;
        VAR num rms;
        VAR num largest;
        VAR num worst;
        MatrixSolve a, b, x;
        TPWrite rounded(x{1}, x{2}) + "," + DnumToStr(x{3}, 0) + "]";
        MatrixSolve tall, c, y;
        TPWrite rounded(y{1}, y{2}) + "] over";
        MatrixSolveQR tall, q, r;
        TPWrite ValToStr(Abs(DnumToNum(q{1,1} * r{1,1} + q{1,2} * r{2,1}) - 1) < 1E-6)
            + " " + ValToStr(AbsDnum(r{3,1}) < 1E-12);
        MatrixSVD tall, u, s, v \Econ;
        TPWrite ValToStr(AbsDnum(s{1} * s{1} - 3) < 1E-9) + " "
            + ValToStr(AbsDnum(u{1,1} * s{1} * v{1,1} + u{1,2} * s{2} * v{1,2} - 1) < 1E-9);
        way := 1;
        MatrixSolve same, b, y;
        MatrixSolve a \A_m:=4, b, x;
        FitCircle points \NumPoints:=4, centre, radius, normal \RMS:=rms;
        TPWrite "[" + NumToStr(centre.x, 0) + "," + NumToStr(centre.y, 0) + "," + NumToStr(centre.z, 0) + "] "
            + NumToStr(radius, 0) + " [" + NumToStr(Abs(normal.x), 0) + "," + NumToStr(Abs(normal.y), 0) + ","
            + NumToStr(normal.z, 0) + "] " + NumToStr(rms, 3);
        FitCircle [[0,0,0],[1,0,0],[2,0,0]], centre, radius, normal;
        FitCircle [[0,0,0],[1,0,0]], centre, radius, normal \MaxErr:=largest \IndexWorst:=worst;
    ERROR
        TEST ERRNO
        CASE ERR_FIT_POINTS_IN_LINE:
            TPWrite "in line";
        CASE ERR_FIT_TOO_FEW_POINTS:
            TPWrite "too few";
        DEFAULT:
            IF way = 1 THEN
                TPWrite "depend";
            ELSE
                TPWrite "too small";
            ENDIF
            way := way + 1;
        ENDTEST
        TRYNEXT;
    ENDPROC
    FUNC string rounded(dnum one, dnum two)
        RETURN "[" + DnumToStr(one, 0) + "," + DnumToStr(two, 0);
    ENDFUNC
ENDMODULE
