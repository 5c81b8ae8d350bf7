! rule: arguments of CTime
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := CTime();
        r_string := CTime(1);  ! -> RG311
        r_string := CTime(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
