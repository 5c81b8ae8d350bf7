! rule: arguments of RemainingRetries
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := RemainingRetries();
        r_num := RemainingRetries(1);  ! -> RG311
        r_num := RemainingRetries(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
