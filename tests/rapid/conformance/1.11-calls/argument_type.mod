! rule: an argument has the type of its parameter
! source: [K §3.10, 5.1]
MODULE Demo
    PROC main()
        p "1";  ! -> RG307
    ENDPROC
    PROC p(num a)
        TPWrite "" \Num:=a;
    ENDPROC
ENDMODULE
