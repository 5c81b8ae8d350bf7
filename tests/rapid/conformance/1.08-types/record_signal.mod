! rule: a component is no signal
! source: [K §2.14]
MODULE Demo
    RECORD r
        signaldi x;  ! -> RG327
    ENDRECORD
ENDMODULE
