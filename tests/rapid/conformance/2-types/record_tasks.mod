! rule: components of tasks
! source: [manual] 3HAC050917, an initial value of one string
MODULE Demo
    VAR tasks a := ["T_ROB1"];
    VAR string s;
    PROC main()
        s := a.taskname;
        s := a.nothing;  ! -> RG304
    ENDPROC
ENDMODULE
