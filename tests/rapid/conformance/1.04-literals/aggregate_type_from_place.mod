! rule: two aggregates with + or - between them have the type of the place
! source: [K §3.9] the type follows from the context; loaded: CalibrateCamera.sys of a YuMi, saved for months [code TechnoX]
MODULE Demo
    VAR pos p;
    VAR num a;
    PROC main()
        p := [a, 2, 3] - [1, 2, 3];
        a := Length([a, 2, 3] + [1, 2, 3]);
        a := [1, 2, 3] - [1, 2, 3];  ! -> RG330
    ENDPROC
    FUNC num Length(pos v)
        RETURN v.x;
    ENDFUNC
ENDMODULE
