! rule: arguments of GInputDnum
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalgi v_signalgi;
    VAR dnum r_dnum;
    PROC main()
        r_dnum := GInputDnum(v_signalgi);
        r_dnum := GInputDnum();  ! -> RG311
        r_dnum := GInputDnum(v_signalgi \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
