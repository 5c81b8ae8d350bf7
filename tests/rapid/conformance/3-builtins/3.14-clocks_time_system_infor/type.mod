! rule: arguments of Type
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR string r_string;
    PROC main()
        r_string := Type(v_num);
        r_string := Type(v_num \BaseName);
        r_string := Type();  ! -> RG311
        r_string := Type(v_num \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
