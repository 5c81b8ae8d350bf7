! rule: arguments of NumToDnum
! source: [manual] 3HAC050917
MODULE Demo
    VAR dnum r_dnum;
    PROC main()
        r_dnum := NumToDnum(1);
        r_dnum := NumToDnum();  ! -> RG311
        r_dnum := NumToDnum(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
