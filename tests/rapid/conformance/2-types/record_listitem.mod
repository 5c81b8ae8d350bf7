! rule: components of listitem
! source: [code] rapid-for-vim
MODULE Demo
    VAR listitem a := ["T_ROB1", "T_ROB1"];
    VAR string s;
    PROC main()
        s := a.image;
        s := a.text;
        s := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
