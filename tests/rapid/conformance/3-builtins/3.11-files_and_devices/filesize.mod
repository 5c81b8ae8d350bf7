! rule: arguments of FileSize
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := FileSize("x");
        r_num := FileSize();  ! -> RG311
        r_num := FileSize("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
