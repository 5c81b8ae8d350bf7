! rule: predefined zones
! source: [code] abb_motion_program_exec
MODULE Demo
    VAR zonedata z;
    PROC main()
        z := fine;
        z := z0;
        z := z1;
        z := z5;
        z := z10;
        z := z15;
        z := z20;
        z := z30;
        z := z40;
        z := z50;
        z := z60;
        z := z80;
        z := z100;
        z := z150;
        z := z200;
        z := 1;  ! -> RG307
    ENDPROC
ENDMODULE
