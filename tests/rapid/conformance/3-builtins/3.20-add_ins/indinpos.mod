! rule: arguments of IndInpos
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r;
    VAR mecunit v_mecunit;
    PROC main()
        r := IndInpos(v_mecunit, 1);
        r := IndInpos();  ! -> RG311
        r := IndInpos(v_mecunit, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
