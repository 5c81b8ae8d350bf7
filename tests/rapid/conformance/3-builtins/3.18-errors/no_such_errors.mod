! rule: names that look likely and do not exist
! source: [code] rapid-for-vim has the whole list
! given: system
MODULE Demo
    VAR errnum e;
    PROC main()
        e := ERR_SOCK_NOT_CREATED;  ! -> RG302
        e := ERR_RAWBYTES;  ! -> RG302
    ENDPROC
ENDMODULE
