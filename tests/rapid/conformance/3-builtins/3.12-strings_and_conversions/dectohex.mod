! rule: arguments of DecToHex
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := DecToHex("x");
        r_string := DecToHex();  ! -> RG311
        r_string := DecToHex("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
