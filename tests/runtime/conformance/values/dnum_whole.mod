MODULE dnum_whole
    ! source: [mem] a dnum counts whole numbers to 2^52; as an IEEE double it would to 2^53
    ! case:
    ! expect: lost
    ! case: dnum_whole=53
    ! expect: counted
    PROC main()
        VAR dnum large := 4503599627370496;
        VAR dnum small := 1;
        VAR dnum product;

        product := 2 * large - small;
        IF product - large = large - small THEN
            TPWrite "counted";
        ELSE
            TPWrite "lost";
        ENDIF
    ENDPROC
ENDMODULE
