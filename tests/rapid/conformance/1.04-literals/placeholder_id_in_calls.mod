! rule: <ID> stands for a name in the arguments of a procedure, not of a function
! source: [K §2.9, 3.10, 4.5]
MODULE Demo
    RECORD r
        <ID> x;
    ENDRECORD
    VAR num a;
    PROC main()
        TPWrite "x" \<ID>:=1;
        TPWrite <ID>:="x";
        own <ID>:=1 \<ID>?<ID>;
        a := Abs(\<ID>);  ! -> RG201
    ENDPROC
ENDMODULE
