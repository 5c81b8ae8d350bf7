! rule: finep and robhold are bool, ufprog too
! source: [manual] 3HAC050917
MODULE Demo
    VAR zonedata z;
    VAR tooldata t;
    VAR wobjdata w;
    VAR tasks k;
    VAR bool b;
    VAR string s;
    PROC main()
        b := z.finep;
        b := t.robhold;
        b := w.ufprog;
        s := w.ufmec;
        s := k.taskname;
    ENDPROC
ENDMODULE
