! rule: arguments of GetTime
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := GetTime();
        r_num := GetTime(\WDay);
        r_num := GetTime(\Hour);
        r_num := GetTime(\Min);
        r_num := GetTime(\Sec);
        r_num := GetTime(1);  ! -> RG311
        r_num := GetTime(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
