! rule: arguments of NumToStr
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := NumToStr(1, 1);
        r_string := NumToStr(1, 1 \Exp);
        r_string := NumToStr(1);  ! -> RG311
        r_string := NumToStr(1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
