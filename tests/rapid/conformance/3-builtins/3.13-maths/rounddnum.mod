! rule: arguments of RoundDnum
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum r_dnum;
    PROC main()
        r_dnum := RoundDnum(1);
        r_dnum := RoundDnum(1 \Dec:=1);
        r_dnum := RoundDnum();  ! -> RG311
        r_dnum := RoundDnum(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
