! rule: arguments of a procedure whose name is known
! source: [K §4.5]
MODULE Demo
    CONST string NAME := "p";
    PROC main()
        %"p"% "x";  ! -> RG307?
        %"p"%;  ! -> RG311?
        %NAME% 1;
        %"f"%;  ! -> RG306?
    ENDPROC
    PROC p(num n)
        TPWrite "" \Num:=n + f();
    ENDPROC
    FUNC num f()
        RETURN 1;
    ENDFUNC
ENDMODULE
