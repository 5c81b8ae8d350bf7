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
