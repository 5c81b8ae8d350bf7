! rule: predefined speeds of rotating and linear external axes
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR speeddata s;
    PROC main()
        s := vrot1;
        s := vrot2;
        s := vrot5;
        s := vrot10;
        s := vrot20;
        s := vrot50;
        s := vrot100;
        s := vlin10;
        s := vlin20;
        s := vlin50;
        s := vlin100;
        s := vlin200;
        s := vlin500;
        s := vlin1000;
        s := vrot3;  ! -> RG302
    ENDPROC
ENDMODULE
