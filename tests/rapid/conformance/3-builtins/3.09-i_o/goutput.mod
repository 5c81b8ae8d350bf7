! rule: arguments of GOutput
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalgo v_signalgo;
    VAR num r_num;
    PROC main()
        r_num := GOutput(v_signalgo);
        r_num := GOutput();  ! -> RG311
        r_num := GOutput(v_signalgo \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
