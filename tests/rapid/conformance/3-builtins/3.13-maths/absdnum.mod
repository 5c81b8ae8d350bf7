! rule: arguments of AbsDnum
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum r_dnum;
    PROC main()
        r_dnum := AbsDnum(1);
        r_dnum := AbsDnum();  ! -> RG311
        r_dnum := AbsDnum(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
