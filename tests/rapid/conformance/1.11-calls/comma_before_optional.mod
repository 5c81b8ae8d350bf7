! rule: a comma before an optional argument is free
! source: [K §3.10] [code] abb_driver
MODULE Demo
    VAR socketdev s;
    VAR rawbytes b;
    PROC main()
        SocketReceive s, \RawData:=b, \Time:=5;
        SocketReceive s \RawData:=b \Time:=5;
    ENDPROC
ENDMODULE
