! rule: arguments of AOutput
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalao v_signalao;
    VAR num r_num;
    PROC main()
        r_num := AOutput(v_signalao);
        r_num := AOutput();  ! -> RG311
        r_num := AOutput(v_signalao \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
