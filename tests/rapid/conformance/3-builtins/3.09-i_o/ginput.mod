! rule: arguments of GInput
! source: [manual] 3HAC050917
MODULE Demo
    VAR signalgi v_signalgi;
    VAR num r_num;
    PROC main()
        r_num := GInput(v_signalgi);
        r_num := GInput();  ! -> RG311
        r_num := GInput(v_signalgi \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
