! rule: predefined constants are there
! source: [code] rapid-for-vim
MODULE Demo
    VAR num a;
    PROC main()
        a := pi + EOF_BIN + EOF_NUM + WAIT_MAX + ERRNO + INTNO;
        TPWrite EOF + stEmpty + STR_DIGIT;
    ENDPROC
ENDMODULE
