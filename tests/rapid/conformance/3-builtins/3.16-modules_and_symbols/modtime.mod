! rule: arguments of ModTime
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    VAR stringdig v_stringdig;
    PROC main()
        r_num := ModTime("x");
        r_num := ModTime("x" \StrDig:=v_stringdig);
        r_num := ModTime();  ! -> RG311
        r_num := ModTime("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
