! rule: an array parameter takes any size of its degree
! source: [K §5.1]
MODULE Demo
    VAR num a{2};
    VAR num b{9};
    VAR num c{2, 2};
    PROC main()
        sum a;
        sum b;
        sum c;  ! -> RG307
    ENDPROC
    PROC sum(num v{*})
        TPWrite "" \Num:=Dim(v, 1) + v{1};
    ENDPROC
ENDMODULE
