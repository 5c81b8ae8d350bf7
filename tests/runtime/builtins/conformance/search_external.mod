MODULE search_external
    ! source: [manual] 3HAC050917 SearchExtJ: as SearchL, with external axes alone
    ! robot: irb120_track
    ! expect: found TRUE at 250
    ! expect: none
    ! expect: 400
    PERS bool hit := FALSE;
    VAR jointtarget j;
    VAR jointtarget found;
    VAR intnum i;
    TRAP comes
        hit := TRUE;
    ENDTRAP
    PROC main()
        j := CJointT();
        j.extax.eax_a := 200;
        MoveAbsJ j, v1000, fine, tool0;
        j.extax.eax_a := 300;
        CONNECT i WITH comes;
        ITimer \Single, 0.5, i;
        SearchExtJ \SStop, hit, found, j, vlin100;
        TPWrite "found " + ValToStr(found.extax.eax_a > 240 AND found.extax.eax_a < 260) + " at "
            + ValToStr(Round(found.extax.eax_a / 50) * 50);
        j.extax.eax_a := 400;
        hit := FALSE;
        SearchExtJ hit, found, j, vlin100;
    ERROR
        IF ERRNO = ERR_WHLSEARCH THEN
            TPWrite "none";
            found := CJointT();
            TPWrite ValToStr(Round(found.extax.eax_a));
            TRYNEXT;
        ENDIF
    ENDPROC
ENDMODULE
