! rule: arguments of StrMap
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := StrMap("x", "x", "x");
        r_string := StrMap("x", "x");  ! -> RG311
        r_string := StrMap("x", "x", "x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
