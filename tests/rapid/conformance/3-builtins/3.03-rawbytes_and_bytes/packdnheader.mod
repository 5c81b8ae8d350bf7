! rule: arguments of PackDNHeader
! source: [manual] 3HAC050917
MODULE Demo
    VAR rawbytes v_rawbytes;
    PROC main()
        PackDNHeader "x", "x", v_rawbytes;
        PackDNHeader "x", "x";  ! -> RG311
        PackDNHeader "x", "x", v_rawbytes \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
