! rule: arguments of StrLen
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := StrLen("x");
        r_num := StrLen();  ! -> RG311
        r_num := StrLen("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
