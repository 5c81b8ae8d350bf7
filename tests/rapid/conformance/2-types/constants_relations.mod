! rule: named values: relations
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR num n;
    PROC main()
        n := LT;
        n := LTEQ;
        n := EQ;
        n := NOTEQ;
        n := GTEQ;
        n := GT;
        n := OpAdd;
        n := OpSub;
        n := OpMult;
        n := OpDiv;
        n := OpMod;
        n := no_such_value;  ! -> RG302
    ENDPROC
ENDMODULE
