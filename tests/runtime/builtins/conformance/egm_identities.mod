MODULE egm_identities
    ! source: [manual] 3HAC073318: at most four identities; [code] a GoFa with RobotWare 7.21 stops
    ! with "Too many EGM instances"
    ! robot: irb120
    ! expect: four
    ! expect: one was given back
    ! fault: 49911 22
    VAR egmident many{6};

    PROC main()
        FOR i FROM 1 TO 4 DO
            EGMGetId many{i};
        ENDFOR
        TPWrite "four";
        EGMReset many{2};
        Take 5;
        TPWrite "one was given back";
        Take 6;
    ENDPROC

    PROC Take(num i)
        EGMGetId many{i};
    ENDPROC
ENDMODULE
