! rule: characters that nobody sees are told once, by their number
! source: [K §2.8]
! at 7: RG204
MODULE Demo
    VAR num a;
    PROC main()
        a　:= 1;
        a := a​ + 2;
        ! 　 in comments they do no harm
        TPWrite " ";
    ENDPROC
ENDMODULE
