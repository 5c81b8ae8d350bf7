! rule: arguments of CDate
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := CDate();
        r_string := CDate(1);  ! -> RG311
        r_string := CDate(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
