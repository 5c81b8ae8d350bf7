! rule: arguments of ReadErrData
! source: [manual] 3HAC050917
MODULE Demo
    VAR trapdata v_trapdata;
    VAR errdomain v_errdomain;
    VAR num v_num;
    VAR errtype v_errtype;
    VAR string v_string;
    PROC main()
        ReadErrData v_trapdata, v_errdomain, v_num, v_errtype;
        ReadErrData v_trapdata, v_errdomain, v_num, v_errtype \Title:=v_string \Str1:=v_string \Str2:=v_string \Str3:=v_string \Str4:=v_string \Str5:=v_string;
        ReadErrData v_trapdata, v_errdomain, v_num;  ! -> RG311
        ReadErrData v_trapdata, v_errdomain, v_num, v_errtype \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
