! rule: predefined stop points
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR stoppointdata s;
    PROC main()
        s := inpos20;
        s := inpos50;
        s := inpos100;
        s := stoptime0_5;
        s := stoptime1_0;
        s := stoptime1_5;
        s := fllwtime0_5;
        s := fllwtime1_0;
        s := fllwtime1_5;
        s := inpos30;  ! -> RG302
    ENDPROC
ENDMODULE
