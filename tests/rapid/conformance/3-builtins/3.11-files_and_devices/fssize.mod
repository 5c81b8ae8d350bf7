! rule: arguments of FSSize
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := FSSize("x");
        r_num := FSSize("x" \Total \Kbyte \Mbyte);
        r_num := FSSize("x" \Free \Kbyte \Mbyte);
        r_num := FSSize();  ! -> RG311
        r_num := FSSize("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
