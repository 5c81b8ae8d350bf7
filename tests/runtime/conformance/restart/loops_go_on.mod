MODULE loops_go_on
    ! source: [S4 overview 3-23] loops go on behind the pass
    ! do: start, run 1
    ! expect: 13
    ! expect: 12
    ! expect: 11
    ! expect: i
    ! expect: 23
    ! state: error
    ! do: start, run 1
    ! state: error
    ! do: set bad 0, start, run 1
    ! expect: 22
    ! expect: 21
    ! expect: i
    ! expect: 33
    ! expect: 32
    ! expect: 31
    ! expect: i
    ! expect: w1
    ! expect: w2
    ! expect: end
    ! state: finished
    PERS num bad := 1;
    VAR num waste;
    VAR num one{1};
    PROC main()
        VAR num w := 0;
        FOR i FROM 1 TO 3 DO
            FOR j FROM 3 TO 1 STEP -1 DO
                IF i = 2 AND j = 2 fails;
                TPWrite ValToStr(i) + ValToStr(j);
            ENDFOR
            TPWrite "i";
        ENDFOR
        FOR i FROM 0.5 TO 2 DO
            WHILE w < i DO
                w := w + 1;
                IF i = 1.5 fails;
                TPWrite "w" + ValToStr(w);
            ENDWHILE
        ENDFOR
        TPWrite "end";
    ENDPROC

    PROC fails()
        waste := one{1 + bad};
    ENDPROC
    FUNC num value(num v)
        waste := one{1 + bad};
        RETURN v;
    ENDFUNC
ENDMODULE
