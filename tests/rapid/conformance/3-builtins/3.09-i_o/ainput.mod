! rule: arguments of AInput
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalai v_signalai;
    VAR num r_num;
    PROC main()
        r_num := AInput(v_signalai);
        r_num := AInput();  ! -> RG311
        r_num := AInput(v_signalai \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
