! rule: a procedure by its name in a string
! source: [K §4.5]
MODULE Demo
    VAR string a;
    PROC main()
        %"p"% 1;
        %"p" + a% 1 \b:=2;
        %":p"% 1;
    ENDPROC
    PROC p(num n \num b)
        IF Present(b) TPWrite "" \Num:=n;
    ENDPROC
ENDMODULE
