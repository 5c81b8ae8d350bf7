! rule: arguments of VectMagn
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := VectMagn([1, 2, 3]);
        r_num := VectMagn();  ! -> RG311
        r_num := VectMagn([1, 2, 3] \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
