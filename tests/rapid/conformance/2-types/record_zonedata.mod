! rule: components of zonedata
! source: [manual] 3HAC050917
MODULE Demo
    VAR zonedata a;
    VAR num n;
    PROC main()
        n := a.pzone_tcp;
        n := a.pzone_ori;
        n := a.pzone_eax;
        n := a.zone_ori;
        n := a.zone_leax;
        n := a.zone_reax;
        n := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
