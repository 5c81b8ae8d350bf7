! rule: arguments of GOutputDnum
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalgo v_signalgo;
    VAR dnum r_dnum;
    PROC main()
        r_dnum := GOutputDnum(v_signalgo);
        r_dnum := GOutputDnum();  ! -> RG311
        r_dnum := GOutputDnum(v_signalgo \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
