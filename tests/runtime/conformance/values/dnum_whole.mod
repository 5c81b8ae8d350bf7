MODULE dnum_whole
    ! source: [mem] a dnum counts whole numbers to 2^52; as an IEEE double it would to 2^53
    ! case:
    ! expect: lost
    ! expect: TRUE TRUE TRUE TRUE TRUE TRUE
    ! case: dnum_whole=53
    ! expect: counted
    ! expect: FALSE FALSE TRUE TRUE TRUE TRUE
    CONST dnum BEYOND_52 := 4503599627370497;
    VAR dnum list{2} := [4503599627370497, 9007199254740993];
    PROC main()
        VAR dnum large := 4503599627370496;
        VAR dnum small := 1;
        VAR dnum product;
        VAR dnum stepped := 9007199254740992;

        product := 2 * large - small;
        IF product - large = large - small THEN
            TPWrite "counted";
        ELSE
            TPWrite "lost";
        ENDIF
        Incr stepped;
        TPWrite same(BEYOND_52, large) + same(list{1}, large) + same(list{2}, 2 * large)
            + same(9007199254740993, 2 * large) + same(stepped, 2 * large)
            + ValToStr(large * 2 + 1 = 2 * large);
    ENDPROC
    FUNC string same(dnum one, dnum other)
        RETURN ValToStr(one = other) + " ";
    ENDFUNC
ENDMODULE
