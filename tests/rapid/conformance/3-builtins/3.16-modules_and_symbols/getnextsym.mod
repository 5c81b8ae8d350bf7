! rule: arguments of GetNextSym
! source: [manual] 3HAC050917
MODULE Demo
    VAR string v_string;
    VAR datapos v_datapos;
    VAR bool r_bool;
    PROC main()
        r_bool := GetNextSym(v_string, v_datapos);
        r_bool := GetNextSym(v_string, v_datapos \Recursive);
        r_bool := GetNextSym(v_string);  ! -> RG311
        r_bool := GetNextSym(v_string, v_datapos \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
