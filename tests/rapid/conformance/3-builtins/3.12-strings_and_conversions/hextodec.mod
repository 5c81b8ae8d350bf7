! rule: arguments of HexToDec
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    PROC main()
        r_string := HexToDec("x");
        r_string := HexToDec();  ! -> RG311
        r_string := HexToDec("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
