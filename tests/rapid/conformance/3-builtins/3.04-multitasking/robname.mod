! rule: arguments of RobName
! source: [mem]
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := RobName();
        r_string := RobName(1);  ! -> RG311
        r_string := RobName(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
