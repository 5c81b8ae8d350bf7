! rule: arguments of ValToStr
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := ValToStr(1);
        r_string := ValToStr();  ! -> RG311
        r_string := ValToStr(1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
